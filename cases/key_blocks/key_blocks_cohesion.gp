# Hoek & Bray's wedge: factor of safety against the joints' stiffness in shear, by law of cohesion
set xlabel 'k_s/k_n'
set ylabel 'factor of safety'
set logscale x
set xrange [1e-4:2]
set yrange [1:1.85]
set key maxrows 4
plot 'cohesion_form.csv' using 'ratio':'plastic' @theory title 'limit equilibrium, all cohesion', \
     '' using 'ratio':'brittle' @theory dt 2 title 'the first slip takes the cohesion', \
     'plastic.csv' using 'ratio':'factor' @computed title 'distinct elements, plastic', \
     'brittle.csv' using 'ratio':'factor' with points lc rgb '#0072b2' pt 4 ps 1.2 title 'distinct elements, brittle'
