# towards equilibrium: largest remaining error of the top's position over the steps taken
set logscale xy
set xlabel 'steps'
set ylabel 'largest error of the settlement from here on, fraction'
set format y '10^{%T}'
set xrange [10:1e5]
plot 'relaxation_100.csv' using 'steps':'error' with lines lc rgb '#d55e00' lw 2 title 'relaxation, 100 blocks', \
     'local_100.csv' using 'steps':'error' with lines lc rgb '#0072b2' lw 2 title 'local damping 0.8, 100 blocks'
