# three blocks on the back, 37.5 degrees, friction 40: creep of the bottom block after the damping has ended
set xlabel 'time without damping (s)'
set ylabel 'displacement of the bottom block (mm)'
set key left top
plot 'column.csv' using 'time_s':'way_mm' with lines ls 2 title 'gravity at once, then no damping', \
     'column_damped.csv' using 'time_s':'way_mm' with lines ls 1 title 'the same, 0.1 of critical damping', \
     'column_rest.csv' using 'time_s':'way_mm' with lines ls 3 title 'from equilibrium, no damping'
