# failure of the slope in the distinct element run: settled, and in the last failed trial, its motion magnified
set size ratio -1
set xlabel 'x (m)'
set ylabel 'y (m)'
set xrange [-8:52]
set yrange [-8:54]
set key noautotitle
unset grid
plot 'dem_fixed.csv' using 1:2 with filledcurves closed fc rgb '#e2e2e2' fs solid border lc rgb '#b0b0b0' title 'fixed rock', \
     'dem_before.csv' using 1:2 with lines lc rgb '#909090' lw 1 title 'settled', \
     'dem_after.csv' using 1:2 with lines lc rgb '#d55e00' lw 2 title 'lost'
