# Error bars against true errors. draw.sh passes: data (bars.csv), cases (names, as words).
set terminal svg size 640,520
set logscale xy
set format xy '10^{%T}'
set xlabel 'true error (deg)'
set ylabel 'error bar of the budget (deg)'
least = 1e-5
set xrange [least:*]
set yrange [*:*]
count = words(cases)
shape(i) = i == 1 ? 6 : i == 2 ? 4 : i == 3 ? 8 : 12
of(i) = strcol('case') eq word(cases, i) ? (column('error_deg') > least ? column('error_deg') : least) : NaN
plot x with lines lw 1 lc rgb '#808080' title 'the bar is the error', \
     for [i=1:count] data using (of(i)):(column('bar_deg')) with points lt i pt shape(i) ps 0.7 title word(cases, i) noenhanced
