# share of truths that bars of k times the printed ones enclose
set xlabel 'k: bar over the printed bar'
set ylabel 'truths enclosed (%)'
set xrange [0:2]
set yrange [0:102]
set key maxrows 3
plot for [i=2:7] 'coverage.csv' using 1:i with lines lt i-1 title columnheader(i), \
     for [i=8:9] '' using 1:i with lines lt i-7 dt 3 title columnheader(i), \
     '' using 1:10 with lines lc rgb "#404040" lw 3 title columnheader(10), \
     '' using 1:11 with lines lc rgb "#404040" lw 3 dt 2 title columnheader(11)
