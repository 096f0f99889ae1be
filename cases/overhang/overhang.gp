# The stack 0.1 % below its limit with the forces that carry it, and the rotation of its top as the overhang grows.
set terminal svg size 760,620 @page
set multiplot

set origin 0, 0.52
set size 1, 0.48
@picture
set lmargin 2
set rmargin 2
set tmargin 0.5
set bmargin 0.5
unset key
set xrange [-1.3:2.0]
set yrange [-0.28:1.45]
set object 1 rectangle from -1.2, -0.25 to 0, 0 fc rgb '#d9d9d9' fs solid noborder behind
set arrow 1 from 0, -0.08 to 1.1015, -0.08 heads size 0.03, 20 lc rgb '#404040'
set label 1 '0.9648 L/2 (1 + 1/2 + 1/3 + 1/4 + 1/5)' at 0.1, -0.19 left
set label 2 'forces, in weights of a block' at -1.15, 1.15 left tc rgb '#0072b2'
plot 'stack.csv' using 1:2 @stone, \
     'forces.csv' using 1:($2 - 0.012*$3):(0):(0.024*$3) with vectors nohead lc rgb '#0072b2' lw 4, \
     '' using ($3 > 0.3 ? $1 - 0.06 : NaN):2:(sprintf('%.1f', $3)) with labels right offset 0, 0.7 tc rgb '#0072b2'

set origin 0, 0
set size 1, 0.5
set size noratio
unset object 1
unset arrow 1
unset label 1
unset label 2
set lmargin 10
set rmargin 4
set tmargin 1
set bmargin 4
set border 3 lc rgb '#606060' lw 1
set xtics nomirror out scale 0.6 textcolor rgb '#202020'
set ytics nomirror out scale 0.6 textcolor rgb '#202020'
set grid back lc rgb '#e2e2e2' lw 1 dt 1
set key at graph 0.36, 0.95 vertical
set xlabel 'overhang over the harmonic one'
set ylabel 'rotation of the top block (°)'
set xrange [0.905:1.002]
set yrange [0:1]
set arrow 2 from 1, 0 to 1, 1 nohead lc rgb '#0072b2' lw 2 dt 2
set label 3 'rigid blocks' at 0.999, 0.9 right tc rgb '#0072b2'
plot 'theory.csv' using 'share':'turn_deg' @theory title 'rigid blocks on elastic joints', \
     'turn.csv' using 'share':'turn_deg' @computed title 'DEM, 2-D', \
     'limit.csv' using 'share':'turn_deg' with lines lc rgb '#909090' lw 1.5 dt 3 title 'its limit'
unset multiplot
