# force against tilt of a pushed column, and the force that tips it against the stiffness of the joint
set terminal svg size 980,430 @page
set multiplot layout 1,2 margins 0.09,0.98,0.15,0.95 spacing 0.1
set xlabel 'tilt (mrad)'
set ylabel 'force over that of a rigid joint'
set xrange [0:16]
set yrange [0.8:1.005]
set key inside bottom right vertical maxcols 1
plot 'theory.csv' using 1:4 with lines lt 1 title '1000 GPa/m', \
     'found_1000.csv' using 1:2 with points lt 1 pt 7 notitle, \
     'theory.csv' using 1:3 with lines lt 2 title '10 GPa/m', \
     'found_10.csv' using 1:2 with points lt 2 pt 7 notitle, \
     'theory.csv' using 1:2 with lines lt 3 title '1 GPa/m', \
     'found_1.csv' using 1:2 with points lt 3 pt 7 title 'DEM, in equilibrium'
set xlabel 'normal stiffness of the joint (GPa/m)'
set logscale x
set format x '10^{%T}'
set xrange [0.3:10000]
plot 'limit.csv' using 'stiffness_GPa_m':'force' @theory title 'tips, joint without tension', \
     1 with lines lc rgb '#0072b2' lw 1.5 dt 2 title 'rigid joint', \
     'found.csv' using 'stiffness_GPa_m':'force' @computed title 'DEM, found by search'
unset multiplot
