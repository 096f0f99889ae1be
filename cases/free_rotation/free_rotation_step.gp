# largest error of the angular velocity in 45 s against the turn in a step
set xlabel 'turn in a step (rad)'
set ylabel 'largest error (rad/s)'
set logscale xy
set xrange [0.004:0.1]
set format xy '10^{%T}'
set key top left
plot 1.5*x**2 @theory title 'second order', \
     'steps.csv' using 'omega_dt':'implicit' @computed title 'implicit', \
     '' using 'omega_dt':'explicit' with points lc rgb '#0072b2' pt 4 ps 0.8 title 'explicit'
