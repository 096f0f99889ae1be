# a burst that rises through the column, turns back at its surface and leaves at its base
set xlabel 'time since the wave entered (s)'
set ylabel 'velocity over that of the wave'
set xrange [0:0.4]
set yrange [-2.2:2.2]
plot 'column.csv' using 'time_s':'middle' with lines lc rgb '#0072b2' title 'middle', \
     '' using 'time_s':'surface' with lines lc rgb '#d55e00' title 'surface'
