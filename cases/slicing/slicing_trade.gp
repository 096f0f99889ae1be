# cost and savings of the limits on blocks
set terminal svg size 860,640 @page
set multiplot layout 2,2
set xlabel 'smallest inscribed radius allowed, m'
set xrange [-0.01:0.21]
set key inside top right vertical
any = "with linespoints lt 1 title 'aspect ratio: any'"
ten = "with linespoints lt 2 title 'at most 10'"
four = "with linespoints lt 3 title 'at most 4'"

set ylabel 'blocks'
set yrange [0:*]
plot 'trade_any.csv' using 'limit_m':'blocks' @any, 'trade_10.csv' using 'limit_m':'blocks' @ten, \
     'trade_4.csv' using 'limit_m':'blocks' @four
unset key
set logscale y
set format y '10^{%L}'
set yrange [*:*]
set ylabel 'mass of the smallest block, kg'
plot 'trade_any.csv' using 'limit_m':'mass_kg' @any, 'trade_10.csv' using 'limit_m':'mass_kg' @ten, \
     'trade_4.csv' using 'limit_m':'mass_kg' @four
set ylabel 'time step, µs'
set format y '%g'
plot 'trade_any.csv' using 'limit_m':(1e6*column('step_s')) @any, \
     'trade_10.csv' using 'limit_m':(1e6*column('step_s')) @ten, \
     'trade_4.csv' using 'limit_m':(1e6*column('step_s')) @four
set ylabel 'contact evaluations for one second'
set format y '10^{%L}'
plot 'trade_any.csv' using 'limit_m':'evaluations_per_second' @any, \
     'trade_10.csv' using 'limit_m':'evaluations_per_second' @ten, \
     'trade_4.csv' using 'limit_m':'evaluations_per_second' @four
unset multiplot
