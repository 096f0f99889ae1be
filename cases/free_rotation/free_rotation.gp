# angular velocity in the axes of the box
set xlabel 'time (s)'
set ylabel 'angular velocity in the axes of the box (rad/s)'
set xrange [0:45]
plot 'spin.csv' using 'time_s':'exact_x' with lines lt 7 title 'elliptic functions', \
     '' using 'time_s':'exact_y' with lines lt 7 title '', \
     '' using 'time_s':'exact_z' with lines lt 7 title '', \
     '' using 'time_s':'x_rad_per_s' every 20 with points lt 1 title 'x, smallest moment', \
     '' using 'time_s':'y_rad_per_s' every 20 with points lt 2 title 'y, middle', \
     '' using 'time_s':'z_rad_per_s' every 20 with points lt 3 title 'z, largest'
