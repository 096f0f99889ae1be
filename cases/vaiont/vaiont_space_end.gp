# the slide in space at its failure: from above, from the gorge, and cut along its seat
set terminal svg size 1000,700 @page
@picture
unset key
set multiplot
set lmargin at screen 0.01
set rmargin at screen 0.49
set tmargin at screen 0.93
set bmargin at screen 0.44
set title 'from above, north up'
load 'space_plan.gp'
set xrange [right_min:right_max]
set yrange [1000:up_max]
plot NaN notitle
unset object
set lmargin at screen 0.51
set rmargin at screen 0.99
set title 'from the gorge, looking south'
load 'space_north.gp'
set xrange [right_min:right_max]
set yrange [up_min:up_max]
plot NaN notitle
unset object
set lmargin at screen 0.08
set rmargin at screen 0.98
set tmargin at screen 0.36
set bmargin at screen 0.06
set border 3
set xtics 200 nomirror out
set ytics 200 nomirror out
set title 'section along the seat, 1750 m north, looking north: east and elevation in m'
load 'space_section.gp'
set xrange [right_min:right_max]
set yrange [300:1000]
plot NaN notitle
unset multiplot
