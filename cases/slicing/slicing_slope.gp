# the slope: construction joints through everything with persistent sets, and finite cross joints
set terminal svg size 760,900 @page
rock   = "with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#6f6450'"
clump  = "with filledcurves closed fc rgb '#e69f00' fs solid border lc rgb '#6f6450'"
ground = "with filledcurves closed fc rgb '#d5d5d5' fs solid border lc rgb '#606060'"
set multiplot
set size ratio -1
unset grid
set xrange [-10:1310]
set yrange [490:1250]
set xtics 0, 200
set ytics 500, 100
set ylabel 'elevation (m)' offset 1
set lmargin at screen 0.115
set rmargin at screen 0.98
set key at first 1290, 1235 top right vertical samplen 2 spacing 1.3 opaque noautotitle width 1

set tmargin at screen 0.985
set bmargin at screen 0.525
set label 1 'a' at 20, 1225 font ',17'
set format x ''
unset xlabel
set arrow 11 from 0, 1186.26 to 1300, 738.60 nohead dt 3 lc rgb '#d55e00' lw 1.5 front
set arrow 12 from 66.4, 1250 to 1227.7, 500 nohead dt 3 lc rgb '#d55e00' lw 1.5 front
set arrow 13 from 0, 850 to 1300, 850 nohead dt 3 lc rgb '#d55e00' lw 1.5 front
set arrow 14 from 408.0, 1250 to 1300, 553.1 nohead dt 3 lc rgb '#d55e00' lw 1.5 front
set label 2 'zone 1' at 640, 1120 center tc rgb '#d55e00'
set label 3 'zone 2' at 772, 880 center tc rgb '#d55e00'
set label 4 'zone 3' at 1235, 690 center tc rgb '#d55e00'
set label 5 'boundary block' at 300, 640 center front
plot 'slope_fixed.csv' using 1:2 @ground title 'never moves', \
     'slope_single.csv' using 1:2 @rock title 'block', \
     'slope_clumps.csv' using 1:2 @clump title 'block of several parts', \
     NaN with lines dt 3 lc rgb '#d55e00' lw 1.5 title 'construction joints'

do for [k = 11:14] { unset arrow k }
do for [k = 2:4] { unset label k }
set tmargin at screen 0.515
set bmargin at screen 0.065
set format x '%g'
set xlabel 'distance (m)' offset 0, 0.5
set label 1 'b'
plot 'slope_finite_fixed.csv' using 1:2 @ground title 'never moves', \
     'slope_finite_single.csv' using 1:2 @rock title 'block', \
     'slope_finite_clumps.csv' using 1:2 @clump title 'block of several parts'
unset multiplot
