# error of the angle found by a constant rate, always too low
set logscale xy
set xlabel 'rate of reduction (deg/s)'
set ylabel 'critical angle found too low by (deg)'
set xrange [0.08:4]
plot 'rates.csv' using 'rate_deg_per_s':'formula_deg' @theory title '(6 X cos θ r^2/((1-α) g))^{1/3}', \
     '' using 'rate_deg_per_s':'bias_deg' @computed title 'this run'
