# critical friction of the wedge over its weight, at the same horizontal stress
set xlabel 'weight / weight at 9.81 m/s²'
set ylabel 'critical friction (deg)'
set xrange [0:2.2]
set key bottom right
plot 'closed_form.csv' using 'weight':'friction_deg' @theory title 'joint relaxation, closed form', \
     'weight.csv' using 'weight':'friction_deg' @computed title 'DEM'
