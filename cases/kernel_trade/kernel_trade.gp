# work and precision: the worst of the four errors against planes looked at and against time; the lines are the fronts
set terminal svg size 980,460 @page
set logscale xy
set format y '10^{%T}'
set yrange [1e-12:1]
set ylabel 'worst error: point, normal, overlap, area'
set multiplot layout 1,2 margins 0.09,0.76,0.15,0.95 spacing 0.08
set key at screen 0.99,0.95 right top vertical
do for [panel=1:2] {
  work = panel == 1 ? 'visits' : 'nanoseconds'
  set xlabel panel == 1 ? 'planes looked at, per pair' : 'time of this run, per pair (ns)'
  if (panel == 2) { set key; unset ylabel } else { unset key }
  plot 'front_warm.csv' using work:'worst' with lines lt 1 lw 1.5 notitle, \
       'front_new.csv' using work:'worst' smooth unique with lines lt 2 lw 1.5 notitle, \
       'warm.csv' using work:'worst' with points lt 1 title 'warm', \
       'cold.csv' using work:'worst' with points lt 2 title 'new contact', \
       'lp_tolerance.csv' using work:'worst' with points lt 3 title 'LP tolerance', \
       'plain_double.csv' using work:'worst' with points lt 6 title 'plain double', \
       'plain_float.csv' using work:(column('failed') == 0 ? column('worst') : NaN) with points lt 5 pt 3 title 'plain float', \
       '' using work:(column('failed') > 0 ? column('worst') : NaN) with points lt 5 pt 2 title 'float, pairs it solved', \
       'recommended.csv' using work:'worst' with points lc rgb '#202020' pt 6 ps 1.6 title 'recommended'
}
unset multiplot
