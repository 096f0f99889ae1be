# critical friction of the slide against the height of the water
set xlabel 'water above the seat (m)'
set ylabel 'critical friction of the slide (deg)'
set xrange [-2:232]
set yrange [16:19.5]
plot 'levels_form.csv' using 'water_m':'closed_form_deg' @theory title 'blocks behind mobilised cross joints', \
     'levels.csv' using 'water_m':'limit_deg' @computed title 'limit analysis, three blocks'
