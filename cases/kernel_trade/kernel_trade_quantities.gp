# the four errors separately, against planes looked at; horizontal: effect of another definition of the contact point
set terminal svg size 980,620 @page
set logscale xy
set format y '10^{%T}'
set yrange [1e-17:10]
set xrange [50:3000]
shown(y) = column(y) > 1e-17 ? column(y) : 1e-17
names = 'point normal overlap area'
units = '"fraction of the overlap" "rad" "relative" "relative"'

set multiplot layout 2,2 margins 0.08,0.76,0.11,0.94 spacing 0.08,0.14
set key at screen 0.99,0.95 right top vertical
do for [q=1:4] {
  y = word(names, q)
  set title sprintf('%s (%s)', y, word(units, q)) offset 0,-0.7
  set xlabel q > 2 ? 'planes looked at, per pair' : ''
  if (q == 4) { set key } else { unset key }
  plot 'models.csv' using 'visits':(shown('Chebyshev ' . y)) with lines lt 7 dt 2 title 'Chebyshev, median', \
       '' using 'visits':(shown('centroid ' . y)) with lines lt 4 dt 4 title 'centroid, median', \
       'warm.csv' using 'visits':(shown(y)) with linespoints lt 1 lw 1 title 'warm', \
       'cold.csv' using 'visits':(shown(y)) with linespoints lt 2 lw 1 title 'new contact', \
       'plain_double.csv' using 'visits':(shown(y)) with linespoints lt 6 lw 1 title 'plain double', \
       'plain_float.csv' using 'visits':(shown(y)) with points lt 5 pt 2 ps 0.8 title 'float, pairs it solved'
}
unset multiplot
