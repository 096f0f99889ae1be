# critical angle against the ratio of shear to normal stiffness
stats 'closed_form.csv' using 1 nooutput name 'critical'
set xlabel 'shear stiffness / normal stiffness'
set ylabel 'critical friction angle (deg)'
set xrange [0:2.1]
set yrange [33.2:33.4]
plot critical_min with lines lc rgb '#0072b2' lw 2 dt 2 title 'closed form (rigid block)', \
     'stiffness.csv' using 'ks_over_kn':'path_deg' @theory title 'elastic-plastic path', \
     '' using 'ks_over_kn':'computed_deg' @computed title 'this run, bisection'
