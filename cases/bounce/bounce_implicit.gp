# energy that the first impact of an undamped cube leaves, by implicit steps
set xlabel 'time step / explicit limit'
set ylabel 'energy after the first impact / energy of the fall'
set logscale x
set format x '10^{%T}'
set yrange [-0.05:1.1]
plot 1 @theory title 'energy of the fall', \
     'implicit.csv' using 'limits':'left' @computed title 'implicit steps'
