# Error bars against true errors. draw.sh passes: data (bars.csv), cases (names, '|' between them).
load style
set terminal svg size 640,520
set output out
set logscale xy
set format xy '10^{%T}'
set xlabel 'true error (deg)'
set ylabel 'error bar of the budget (deg)'
set key bottom right
least = 1e-5
set xrange [least:*]
set yrange [*:*]
count = 1
do for [i=1:strlen(cases)] { if (cases[i:i] eq '|') { count = count + 1 } }
array name[count]
rest = cases
do for [i=1:count] {
  cut = strstrt(rest, '|')
  name[i] = cut > 0 ? rest[1:cut-1] : rest
  rest = rest[cut+1:*]
}
shape(i) = i == 1 ? 6 : i == 2 ? 4 : i == 3 ? 8 : 12
of(i) = strcol('case') eq name[i] ? (column('error_deg') > least ? column('error_deg') : least) : NaN
plot x with lines lw 1 lc rgb '#808080' title 'the bar is the error', \
     for [i=1:count] data using (of(i)):(column('bar_deg')) with points lt i pt shape(i) ps 0.7 title name[i] noenhanced
