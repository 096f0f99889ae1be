# displacement of two blocks against the friction of the slide: the central analysis on blocks of 80 m, the short path
set xlabel 'friction of the slide (deg)'
set ylabel 'displacement (m)'
set xrange [24.1:19.5]
set key left top
plot 'fall.csv' using 'friction_deg':'back_m' @computed title 'lowest bed of the back', \
     'fall.csv' using 'friction_deg':'front_m' with points ls 3 title 'front of the seat'
