# the mechanism of the slope: rigid-block limit analysis against blocks that slip without opening
set size ratio -1
set xlabel 'x (m)'
set ylabel 'y (m)'
set xrange [-8:52]
set yrange [-8:54]
set key noautotitle
unset grid
plot 'fixed.csv' using 1:2 with filledcurves closed fc rgb '#e2e2e2' fs solid border lc rgb '#b0b0b0' title 'fixed rock', \
     'free.csv' using 1:2 with lines lc rgb '#909090' lw 1 title 'blocks', \
     'mechanism.csv' using 1:2 with lines lc rgb '#d55e00' lw 2 title 'limit analysis', \
     'plastic.csv' using 1:2 with lines lc rgb '#0072b2' lw 1.5 dt 2 title 'without dilation'
