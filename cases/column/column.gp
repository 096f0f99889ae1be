# overlap of every joint in equilibrium
set xlabel 'joint, from the ground up'
set ylabel 'overlap (mm)'
set xrange [-0.5:7.5]
set yrange [0:0.9]
plot 'overlaps.csv' using 'joint':'closed_form_mm' @theory title 'closed form', \
     '' using 'joint':'overlap_mm' with points lc rgb '#d55e00' pt 7 ps 1 title 'this run'
