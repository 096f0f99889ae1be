# a joint after Barton and Bandis between springs: lines by closed form, points by the law driver; order of its step
set terminal svg size 1080,420 @page
set multiplot layout 1,3 margins 0.075,0.985,0.15,0.78 spacing 0.095
set key above vertical maxrows 4 samplen 2
set xlabel 'slip (mm)'
set xrange [0:6]
do for [stress in 'shear normal'] {
  set ylabel stress.' stress (MPa)'
  set yrange [0:*]
  plot for [k=1:2] 'rough.csv' using 'slip_mm':word('envelope mobilised', k).'_'.stress.'_exact' with lines lt k notitle, \
       for [k=1:2] '' using 'slip_mm':word('envelope mobilised', k).'_'.stress every 6 with points lt k \
         title word('"peak envelope" "mobilised by slip"', k)
}
set logscale xy
set xlabel 'steps'
set ylabel 'relative error of the normal stress'
set format y '10^{%T}'
set xrange [20:2000]
set yrange [*:*]
plot 'order.csv' using 'steps':'envelope' with linespoints lt 1 title 'peak envelope', \
     '' using 'steps':'mobilised' with linespoints lt 2 title 'mobilised by slip', \
     2e-5*(x/25.0)**(-2) with lines lt 8 dt 2 title 'second order'
unset multiplot
