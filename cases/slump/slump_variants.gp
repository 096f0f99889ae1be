# the angle at which each variant of the slope fails, by three methods
set ylabel 'critical friction (deg)'
set xrange [-0.6:13.6]
set yrange [0:30]
set xtics rotate by -40 left
plot 'variants.csv' using 0:'plastic_deg':xtic(1) with points lc rgb '#404040' pt 6 ps 1.4 lw 2 title 'without dilation', \
     '' using 0:'limit_deg' with points lt 1 title 'limit analysis', \
     '' using 0:'dem_deg' with points lc rgb '#d55e00' pt 2 ps 1.1 lw 2 title 'DEM'
