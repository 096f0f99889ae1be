# the rock mass in equilibrium, from the south-east, walls not drawn: displacement of each block
set terminal svg size 860,560 @page
@picture
set key outside bottom center horizontal samplen 1.5
set style fill solid 1 noborder
load 'settled.gp'
set xrange [right_min:right_max]
set yrange [up_min:up_max]
plot keyentry with filledcurves fc rgb '#deebf7' title 'to 0.1 mm', \
     keyentry with filledcurves fc rgb '#9ecae1' title '0.3 mm', \
     keyentry with filledcurves fc rgb '#3182bd' title '1 mm', \
     keyentry with filledcurves fc rgb '#e69f00' title '10 mm', \
     keyentry with filledcurves fc rgb '#d55e00' title 'farther', \
     NaN notitle
