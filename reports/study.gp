# Work and precision of one case's study. draw.sh passes: points (csv), sweeps (names, '|' between them), quantity.
load style
set output out
set datafile missing NaN
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set offsets graph 0.03, graph 0.06, graph 0.08, graph 0.05
set xlabel 'contact evaluations'
set ylabel 'relative error of '.quantity noenhanced
set key noautotitle

# the three accuracies that a recommendation is given for
do for [level in '0.05 0.01 0.001'] {
  set arrow from graph 0, first level + 0 to graph 1, first level + 0 nohead dt 3 lw 1 lc rgb '#808080' back
}
set label 1 '5 %'   at graph 1.005, first 0.05  font ',11' tc rgb '#606060'
set label 2 '1 %'   at graph 1.005, first 0.01  font ',11' tc rgb '#606060'
set label 3 '0.1 %' at graph 1.005, first 0.001 font ',11' tc rgb '#606060'
set rmargin 7

# the names are cut at '|': a sweep's name may hold blanks
count = 1
do for [i=1:strlen(sweeps)] { if (sweeps[i:i] eq '|') { count = count + 1 } }
array name[count]
rest = sweeps
do for [i=1:count] {
  cut = strstrt(rest, '|')
  name[i] = cut > 0 ? rest[1:cut-1] : rest
  rest = rest[cut+1:*]
}

# a row belongs to the curve when quantity and sweep agree; the others are left out without breaking the line
of(i, value) = (strcol('quantity') eq quantity && strcol('sweep') eq name[i]) ? value : NaN
best(value) = (strcol('quantity') eq quantity && strcol('pareto') eq 'yes') ? value : NaN
cost = 'column("contact_evaluations")'
error = 'column("relative_error")'
upper = 'column("relative_error_upper")'
plot for [i=1:count] points using (of(i, @cost)):(@error):(0):(@upper - @error) with vectors nohead lt i lw 1, \
     for [i=1:count] points using (of(i, @cost)):(@error) with linespoints lt i title name[i] noenhanced, \
     points using (best(@cost)):(@error) with points pt 6 ps 1.5 lw 1.5 lc rgb '#202020' title 'Pareto front'
