# overlap while gravity grows, then in equilibrium
stats 'closed_form.csv' using 1 nooutput name 'rest'
set xlabel 'time (s)'
set ylabel 'overlap of the edges (mm)'
set xrange [0:1]
set yrange [0:1.1]
plot rest_min * (x < 0.5 ? x / 0.5 : 1) with lines lc rgb '#404040' lw 2 title 'weight so far / stiffness', \
     'settlement.csv' using 'time_s':'overlap_mm' @computed title 'this run'
