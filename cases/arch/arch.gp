# The arch half a percent thicker than its limit, with the thrust and the forces of its joints, and half a percent
# thinner, during its collapse.
set terminal svg size 760,860 @page
needle = 120e3                 # N/m: drawn 1 m long
set multiplot
@picture
set lmargin 0
set rmargin 0
set tmargin 0
set bmargin 0
set xrange [-6.3:6.3]
set yrange [-0.8:6.0]
do for [side = -1:1:2] {
  set object 2 + side rectangle from side*4.2, -0.55 to side*6.0, 0 fc rgb '#d9d9d9' fs solid noborder behind
  set arrow 2 + side from side*4.2, 0 to side*6.0, 0 nohead lc rgb '#606060' lw 1.5 back
}
set key at first 0.2, 2.1 center vertical samplen 3 spacing 1.3 noautotitle

set origin 0, 0.5
set size 1, 0.5
set label 1 'stable' at 0, 3.35 center font ',17'
set label 2 '0.5 % thicker than the limit on elastic joints' at 0, 2.9 center
set arrow 9 from -0.5, 0.75 to 0.5, 0.75 nohead lc rgb '#0072b2' lw 4
set label 9 '120 kN/m' at 0, 0.42 center tc rgb '#0072b2'
plot 'standing.csv' using 1:2 @stone, \
     'forces.csv' using ($1 - 0.5*$3/needle):($2 - 0.5*$4/needle):($3/needle):($4/needle) \
         with vectors nohead lc rgb '#0072b2' lw 4 title 'forces in the joints', \
     'thrust.csv' using 1:2 with lines lc rgb '#d55e00' lw 1.8 title 'thrust line'

set origin 0, 0
unset arrow 9
unset label 9
set label 1 'collapses'
set label 2 '0.5 % thinner, when the keystone has dropped by 0.25 m'
plot 'standing.csv' using 1:2 with lines lc rgb '#a0a0a0' lw 1 dt 3 title 'before', \
     'falling.csv' using 1:2 @stone, \
     'hinges.csv' using 1:2 with points pt 7 ps 1.1 lc rgb '#d55e00' title 'hinges', \
     '' using 1:2 with points pt 6 ps 1.1 lw 1.2 lc rgb '#202020'
unset multiplot
