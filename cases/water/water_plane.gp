# critical friction of the plane failure as its crack fills
set xlabel 'water in the crack, of its depth'
set ylabel 'critical friction (deg)'
set xrange [-0.02:1.02]
set yrange [30:60]
plot 'plane_form.csv' using 'fill':'critical_deg' @theory title 'limit equilibrium', \
     'plane.csv' using 'fill':'dem_deg' @computed title 'distinct elements', \
     '' using 'fill':'limit_deg' with points lc rgb '#0072b2' pt 4 ps 1.2 title 'limit analysis'
