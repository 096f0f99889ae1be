# cost of the critical angle by each search method
set logscale xy
set xlabel 'contact evaluations'
set ylabel 'error of the critical angle (deg)'
set arrow from graph 0, first 0.05 to graph 1, first 0.05 nohead lc rgb '#404040' lw 1 dt 2
set label '0.05°' at graph 0.98, first 0.05 right offset 0,0.5
plot 'rates.csv' using 'evaluations':'error_deg' with linespoints lt 1 title 'constant rate, 0.1 m', \
     'two_rates.csv' using 'evaluations':'error_deg' with linespoints lt 2 title 'two rates', \
     'bisection.csv' using 'evaluations':'error_deg' with linespoints lt 3 title 'bisection, relaxation', \
     'bisection_local.csv' using 'evaluations':'error_deg' with linespoints lt 4 title 'bisection, local damping'
