# Boon (2013), Figs 4.18 and 4.19: build-up of thrust with gravity. Lines: chain; points: this run.
set terminal svg size 760,640
set multiplot layout 2,1
set xlabel 'gravity (g)'
set ylabel 'thrust (N)'
set yrange [0:*]
set key maxrows 3
set title 'full block' offset 0,-0.8
plot 'full_chain.csv' using 'gravity_g':'thrust_N' @theory title 'chain, distributed joints', \
     'full_chain.csv' using 'gravity_g':'least_thrust_N' with lines lc rgb '#a0a0a0' lw 1.5 dt 2 title 'three hinges at the corners', \
     'full.csv' using 'gravity_g':'thrust_N' with points lt 2 ps 0.8 title '16 sub-contacts', \
     'full_centroid.csv' using 'gravity_g':'thrust_N' with points lt 1 pt 6 ps 0.8 title 'one point, centroid', \
     'full_analytic_centre.csv' using 'gravity_g':'thrust_N' with points lt 3 pt 8 ps 0.9 title 'one point, analytic centre'
set title 'half block'
plot 'half_pushed.csv' using 'gravity_g':'thrust_N' @theory title 'chain, through its loss of equilibrium', \
     'half_chain.csv' using 'gravity_g':'least_thrust_N' with lines lc rgb '#a0a0a0' lw 1.5 dt 2 title 'three hinges at the corners', \
     'half.csv' using 'gravity_g':'thrust_N' with points lt 2 ps 0.8 title '16 sub-contacts'
unset multiplot
