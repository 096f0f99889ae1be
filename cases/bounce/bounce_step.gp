# error of the restitution against the time step
set logscale xy
set xlabel 'time step times eigenfrequency, ω dt'
set ylabel 'relative error of the restitution'
set xrange [0.008:0.5]
set format y '10^{%T}'
plot 'steps.csv' using 'omega_dt':'bound' @theory title 'bound 2ξ ω dt', \
     '' using 'omega_dt':'error' @computed title 'this run'
