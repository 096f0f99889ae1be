# displacement of three blocks against the friction of the slide in space: blocks of 160 m
set xlabel 'friction of the slide (deg)'
set ylabel 'displacement (m)'
set xrange [28.1:8.5]
set yrange [0.001:30]
set logscale y
plot 'space_fall.csv' using 'friction_deg':'west_m' with lines ls 1 title 'west', \
     'space_fall.csv' using 'friction_deg':'centre_m' with lines ls 3 title 'centre', \
     'space_fall.csv' using 'friction_deg':'east_m' with lines ls 2 title 'east'
