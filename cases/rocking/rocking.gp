# the free rocking of the block, and the moment that holds it when it is rotated slowly
set terminal svg size 760,680 @page
set multiplot
set lmargin 11
set rmargin 3
set size 1, 0.5
set origin 0, 0.5
set xlabel 'time since the release of the block (s)'
set ylabel 'lean (°)'
set xrange [0:3.4]
set yrange [-8:8]
plot 'housner.csv' using 'time_s':'lean_deg' @theory title 'Housner, restitution 0.912', \
     'rocking.csv' using 'time_s':'lean_deg' every 6 @computed title 'DEM, dashpot 0.2'
set origin 0, 0
set xlabel 'lean, rotated slowly on a joint of 1 GPa/m (mrad)'
set ylabel "moment over weight and breadth"
set xrange [0:3]
set yrange [0:0.5]
set arrow 1 from 0.1962, 0 to 0.1962, 0.5 nohead lc rgb '#909090' lw 1.2 dt 3
set label 1 'an end lifts off' at 0.22, 0.05 tc rgb '#606060'
plot 'held_4.csv' using 'lean_mrad':'theory' @theory title 'linear pressure, no tension', \
     'held_1.csv' using 'lean_mrad':'arm' every 4 with points lt 1 pt 6 title 'one point', \
     'held_4.csv' using 'lean_mrad':'arm' every 3 @computed title '4 sub-contacts'
unset multiplot
