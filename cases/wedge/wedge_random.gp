# ten random wedges: computed against closed form
set xlabel 'closed form (deg)'
set ylabel 'computed critical friction angle (deg)'
set xrange [0:90]
set yrange [0:90]
set size square
plot x with lines lc rgb '#404040' lw 2 title 'equality', \
     'random.csv' using 'closed_form_deg':'computed_deg' @computed title 'ten random wedges'
