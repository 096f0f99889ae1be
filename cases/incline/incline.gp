# distance over time once friction is below the dip, and above it
set xlabel 'time since friction fell (s)'
set ylabel 'distance down the plane (m)'
set xrange [0:0.51]
set yrange [-0.01:0.25]
plot 'slide.csv' using 'time_s':'closed_form_m' @theory title 'closed form, friction 20°', \
     '' using 'time_s':'distance_m' every 4 @computed title '3-D', \
     'slide_plane.csv' using 'time_s':'distance_m' every 4::2 with points lc rgb '#0072b2' pt 4 ps 0.8 title '2-D', \
     'rest.csv' using 'time_s':'distance_m' every 4 with points lc rgb '#009e73' pt 9 ps 0.7 title '3-D, friction 31°'
