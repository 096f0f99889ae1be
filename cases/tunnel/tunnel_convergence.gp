# convergence of the wall with bolts of 4 m at 15 degrees, and with 10 cm of lining in addition
set xlabel 'angle from the springline to the right (°)'
set ylabel 'convergence (mm)'
set xrange [-90:270]
set yrange [0:*]
set xtics 90
set key top right
plot 'support_walls.csv' using (column('angle_deg')):(1e3*column('bolts_m')) with linespoints lc rgb '#0072b2' pt 4 title 'bolts', \
     '' using (column('angle_deg')):(1e3*column('bolts_and_lining_m')) with linespoints lc rgb '#d55e00' pt 7 title 'bolts and 10 cm of lining'
