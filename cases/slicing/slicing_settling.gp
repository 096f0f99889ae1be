# the rock mass at rest, from the south-east, walls not drawn: by how far each block has gone
load style
set terminal svg size 860,560 dynamic background rgb 'white' font 'DejaVu Sans,Helvetica,Arial,sans-serif,13' \
    linewidth 1 enhanced
set output out
unset border
unset tics
unset grid
set size ratio -1
set key outside bottom center horizontal samplen 1.5
stats 'settled.csv' using 'right_m' nooutput name 'right'
stats 'settled.csv' using 'up_m' nooutput name 'up'
set xrange [right_min:right_max]
set yrange [up_min:up_max]
set style fill solid 1 noborder
plot 'settled.csv' using 'right_m':'up_m':'colour' with filledcurves closed lc rgb variable notitle, \
     '' using 'right_m':'up_m' with lines lc rgb '#303030' lw 0.5 notitle, \
     keyentry with filledcurves fc rgb '#deebf7' title 'to 0.1 mm', \
     keyentry with filledcurves fc rgb '#9ecae1' title '0.3 mm', \
     keyentry with filledcurves fc rgb '#3182bd' title '1 mm', \
     keyentry with filledcurves fc rgb '#e69f00' title '10 mm', \
     keyentry with filledcurves fc rgb '#d55e00' title 'farther'
