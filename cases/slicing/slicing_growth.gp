# time of slicing against the number of blocks, Table 4.1, with and without culling
set terminal svg size 800,420 @page
set multiplot layout 1,2
set logscale xy
set xlabel 'number of blocks'
set ylabel 'time (s)'
set xrange [500:30000]
set yrange [0.02:20]
set format x '10^{%T}'
set key top left inside vertical
do for [name in "persistent finite"] {
  set title name eq 'persistent' ? 'a  persistent joints' : 'b  finite joints'
  stats 'growth_'.name.'.csv' using 'blocks':'seconds' nooutput
  linear(x) = x * STATS_max_y / STATS_max_x
  plot 'growth_'.name.'.csv' using 'blocks':'seconds' with linespoints lt 1 title 'with culling', \
       '' using 'blocks':(column('seconds_without') > 0 ? column('seconds_without') : NaN) with linespoints lt 2 \
           title 'without', \
       linear(x) with lines lc rgb '#404040' lw 1 dt 3 title 'proportional'
}
unset multiplot
