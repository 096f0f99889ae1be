# energy error of the contacts, as a fraction of the energy of the drop, against the time step
set logscale xy
set xlabel 'time step, fraction of the estimated limit'
set ylabel 'energy left open, fraction of that of the drop'
set format y '10^{%T}'
set xrange [0.16:1.25]
set yrange [1e-5:1]
set xtics (0.2, 0.5, 1)
second_order(x) = 2e-3 * x**2
plot 'balance.csv' using 'fraction':'published' with linespoints lt 1 title 'published normal', \
     '' using 'fraction':'multipliers' with linespoints lt 2 title 'multipliers of the program', \
     '' using 'fraction':'central_path' with linespoints lt 3 title 'on the central path', \
     '' using 'fraction':'whole' with linespoints lt 4 title 'integrated face contacts, largest', \
     second_order(x) with lines dt 2 lc rgb '#808080' title 'second order'
