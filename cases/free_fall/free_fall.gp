# the blocks at the start, at impact and at rest; walls are not drawn
set terminal svg size 1000,440 @page
@picture
unset key
set style fill solid 1 noborder
set lmargin 0
set rmargin 0
stats 'start.csv' using 'right_m' nooutput name 'right'
stats 'start.csv' using 'up_m' nooutput name 'up'
set xrange [right_min:right_max]
set yrange [up_min:up_max]
set multiplot layout 1,3
set title 'at the start'
plot 'start.csv' using 'right_m':'up_m':'colour' with filledcurves closed lc rgb variable
set title 'after 0.8 s'
plot 'impact.csv' using 'right_m':'up_m':'colour' with filledcurves closed lc rgb variable
set title 'at rest'
plot 'rest.csv' using 'right_m':'up_m':'colour' with filledcurves closed lc rgb variable
unset multiplot
