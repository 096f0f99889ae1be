# Cost of accuracy, over all cases. draw.sh passes: data (trade.csv), cases (names, as words).
set terminal svg size 760,620
set datafile missing NaN
set logscale xy
set format x '%g'
set format y '10^{%T}'
set offsets graph 0.04, graph 0.06, graph 0.04, graph 0.04
set xlabel 'cost, the scene as it is = 1'
set ylabel 'relative error with error bar'
set key maxrows 4 samplen 2
set rmargin 7

do for [level in '0.05 0.01 0.001'] {
  set arrow from graph 0, first level + 0 to graph 1, first level + 0 nohead dt 3 lw 1 lc rgb '#808080' back
}
set label 1 '5 %'   at graph 1.005, first 0.05  font ',11' tc rgb '#606060'
set label 2 '1 %'   at graph 1.005, first 0.01  font ',11' tc rgb '#606060'
set label 3 '0.1 %' at graph 1.005, first 0.001 font ',11' tc rgb '#606060'
set arrow from first 1, graph 0 to first 1, graph 1 nohead lw 1 lc rgb '#c0c0c0' back

count = words(cases)
# seven colours; those that return are dashed, with open points
colour(i) = (i - 1) % 7 + 1
dash(i) = i > 7 ? 2 : 1
shape(i) = int(word(i > 7 ? '6 4 8 12 10 5 7' : '7 5 9 13 11 4 6', colour(i)))
of(i) = strcol('case') eq word(cases, i) ? column('relative_cost') : NaN
plot for [i=1:count] data using (of(i)):(column('relative_error')) with linespoints lt colour(i) dt dash(i) \
     pt shape(i) ps 0.8 title word(cases, i) noenhanced
