# the stiffer the joints of the wedge in shear, the lower the angle, under 1 kPa as in air
set logscale x
set xlabel 'shear stiffness over normal stiffness'
set ylabel 'critical friction (deg)'
set xrange [0.008:1.25]
set yrange [45.8:46.8]
plot 'wedge_path.csv' using 'ks_over_kn':'path_deg' @theory title 'elastic-plastic path', \
     'wedge.csv' using 'ks_over_kn':'computed_deg' @computed title 'this run'
