# opening 11 of table 5.1, four tenths of a second after the excavation
set terminal svg size 620,560 @page
@picture
unset key
set xrange [-14:14]
set yrange [-11:15]
set title 'opening 11: 85°E, 75°E, 65°W, φ = 25°'
plot 'opening_11_left.csv' using 1:2 with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#b0a58c', \
     'opening_11_lost.csv' using 1:2 with filledcurves closed fc rgb '#d55e00' fs solid border lc rgb '#6f3000'
