# the section cut at both bends of its slide, every 80 m along the seat and every 80 m above the slide
set size ratio -1
unset grid
set xlabel 'distance downslope (m)'
set ylabel 'elevation (m)'
set xrange [-10:1310]
set yrange [540:1250]
set key noautotitle
plot 'fixed.csv' using 1:2 with filledcurves closed fc rgb '#d5d5d5' fs solid border lc rgb '#606060' title 'never moves', \
     'free.csv' using 1:2 with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#6f6450' title 'blocks of 80 m', \
     'slide.csv' using 1:2 with lines lc rgb '#d55e00' lw 2 title 'slide', \
     710 with lines lc rgb '#0072b2' lw 1.5 dt 2 title 'water 90 m above the seat'
