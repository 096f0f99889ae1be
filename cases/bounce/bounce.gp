# height over time against arcs and impacts of the closed form
set xlabel 'time (ms)'
set ylabel 'height of the cube above the base (mm)'
set xrange [0:350]
set yrange [-5:55]
plot for [k=1:4] 'arcs.csv' using (column('arc') == k ? column('time_ms') : NaN):'height_mm' @theory \
     title (k == 1 ? 'closed form' : ''), \
     'height.csv' using 'time_ms':'height_mm' every 4 @computed title 'this run'
