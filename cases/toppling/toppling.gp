# modes of a block on an incline: the map of dynamics, that of statics, and the modes of the runs
set terminal svg size 760,560 @page
set xlabel 'slope of the plane (°)'
set ylabel 'friction angle (°)'
set xrange [0:50]
set yrange [0:55]
rigid = 26.565051177
set key maxrows 2
set style fill transparent solid 0.14 noborder
set label 1 'stays' at 8, 44 font ',15' tc rgb '#404040'
set label 2 'topples' at 37, 48 center font ',15' tc rgb '#009e73'
set label 3 'slides' at 38, 10 center font ',15' tc rgb '#0072b2'
set label 4 'both' at 46, 29 center font ',15' tc rgb '#d55e00'
set label 5 'b/h = 1/2' at 26.1, 53.5 right tc rgb '#606060'
plot '+' using 1:(0):($1 < rigid ? $1 : rigid) with filledcurves fc rgb '#0072b2' notitle, \
     'toppling_alone.csv' using 1:3:2 with filledcurves fc rgb '#d55e00' notitle, \
     '' using 1:2:(55) with filledcurves fc rgb '#009e73' notitle, \
     '' using 1:2 with lines lc rgb '#404040' lw 2 title 'borders, Sagaseta', \
     '' using 1:3 with lines lc rgb '#404040' lw 2 notitle, \
     '+' using ($1 < rigid ? $1 : NaN):1 with lines lc rgb '#404040' lw 2 notitle, \
     '+' using (rigid):($1 > rigid/50*25 ? rigid + ($1 - rigid/2)*0.79 : NaN) with lines lc rgb '#404040' lw 2 notitle, \
     '+' using ($1 > rigid ? $1 : NaN):1 with lines lc rgb '#909090' lw 1.5 dt 2 title 'borders of statics', \
     '+' using (rigid):($1/50*rigid) with lines lc rgb '#909090' lw 1.5 dt 2 notitle, \
     'mode_0.csv' using 1:2 with points pt 6 ps 0.9 lw 1.5 lc rgb '#404040' title 'DEM stays', \
     'mode_1.csv' using 1:2 with points pt 5 ps 0.7 lc rgb '#0072b2' title 'slides', \
     'mode_2.csv' using 1:2 with points pt 9 ps 0.9 lc rgb '#009e73' title 'topples', \
     'mode_3.csv' using 1:2 with points pt 7 ps 0.8 lc rgb '#d55e00' title 'both'
