# displacement of the block down the shaken plane
set xlabel 'time since the shaking began (s)'
set ylabel 'distance down the plane (mm)'
set xrange [0:1.7]
set yrange [0:30]
plot 'space.csv' using 'time_s':'closed_form_mm' @theory title 'closed form', \
     '' using 'time_s':'distance_mm' every 3 @computed title '3-D', \
     'plane.csv' using 'time_s':'distance_mm' every 3::1 with points lc rgb '#0072b2' pt 4 ps 0.8 title '2-D'
