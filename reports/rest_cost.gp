# Seconds to equilibrium of sliced rock by number of blocks, for each static solution method, with the exponent of a line
# through its points.
file = 'rest_cost.csv'
array method[4] = ['newton', 'newton_faces', 'adaptive', 'local']
array name[4] = ["Newton's method, points", "Newton's method, whole faces", 'relaxation, points', 'local damping, points']
array colour[4] = [1, 3, 2, 7]
array exponent[4]
set fit quiet nolog
do for [i=1:4] {
  line(x) = a + b*x
  a = -5
  b = 1
  fit line(x) file using (strcol('method') eq method[i] ? log10(column('blocks')) : NaN):(log10(column('seconds'))) via a, b
  exponent[i] = b
}
set logscale xy
set xlabel 'free blocks'
set ylabel 'processor seconds of one thread'
set xrange [30:40000]
set format y '10^{%T}'
set key inside top left vertical Left reverse samplen 2.5
set yrange [0.01:20000]
of(i, value) = strcol('method') eq method[i] ? value : NaN
plot for [i=1:4] file using 'blocks':(of(i, column('seconds'))) with linespoints lt colour[i] ps 1 \
         title sprintf('%s: exponent %.2f', name[i], exponent[i])
