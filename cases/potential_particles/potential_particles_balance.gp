# energy error of the contacts, as a fraction of the energy of the drop, against the time step
set logscale xy
set xlabel 'time step, fraction of the estimated limit'
set ylabel 'energy left open, fraction of that of the drop'
set format y '10^{%T}'
set xrange [0.015:1.25]
set yrange [1e-6:0.1]
set xtics (0.02, 0.05, 0.1, 0.2, 0.5, 1)
second_order(x) = 1.4e-2 * x**2
plot 'balance.csv' using 'fraction':'bracketed' with linespoints lt 1 title 'bracketed overlap', \
     '' using 'fraction':'conservative' with linespoints lt 2 title 'conservative overlap', \
     second_order(x) with lines dt 2 lc rgb '#808080' title 'second order'
