# Seconds of one load factor of sliced rock by number of blocks, for this program and others on the same problem, with the
# exponent of a line through three or more points.
file = 'limit_cost.csv'
array method[4] = ['cones', 'proof', 'glpk', 'conelp']
array name[4] = ["Voussoir, forces and mechanism", "the same with the proof", "GLPK, simplex, cones of 16 sides", "CVXOPT, conelp"]
array colour[4] = [1, 3, 2, 7]
array label[4]
set fit quiet nolog
do for [i=1:4] {
  stats file using (strcol('method') eq method[i] ? column('blocks') : NaN) nooutput
  label[i] = name[i]
  if (STATS_records > 2) {
    line(x) = a + b*x
    a = -5
    b = 1
    fit line(x) file using (strcol('method') eq method[i] ? log10(column('blocks')) : NaN):(log10(column('seconds'))) via a, b
    label[i] = sprintf('%s: exponent %.2f', name[i], b)
  }
}
set logscale xy
set xlabel 'free blocks'
set ylabel 'processor seconds of one thread'
set xrange [30:4000]
set yrange [0.01:1000]
set format y '10^{%T}'
set key inside bottom right vertical Left reverse samplen 2.5
of(i, value) = strcol('method') eq method[i] ? value : NaN
plot for [i=1:4] file using 'blocks':(of(i, column('seconds'))) with linespoints lt colour[i] ps 1 title label[i]
