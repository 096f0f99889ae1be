# r/size below which the change stays under 5, 1 and 0.1 %, over k; the column is unstable above its line
set terminal svg size 1000,720 @page
set logscale y
set format y '10^{%T}'
set xrange [-0.02:0.95]
set yrange [8e-5:0.7]
problems = 'wedge beam column'
titles = '"wedge: friction angle" "hinged beam: weight" "column: settlement" "settling pack: height"'
if (int(system('[ -f boundary_pack.csv ] && echo 1 || echo 0'))) problems = problems . ' pack'
set multiplot layout 2,2 margins 0.09,0.82,0.09,0.95 spacing 0.09,0.13
do for [p=1:words(problems)] {
  file = 'boundary_' . word(problems, p) . '.csv'
  set title word(titles, p) offset 0,-0.7
  set xlabel (p > 2 || words(problems) - p < 2 ? 'k' : '')
  set ylabel (p % 2 ? 'largest r / size' : '')
  if (p == 3) { set key at screen 0.99,0.95 right top vertical } else { unset key }
  plot file using 'sphericity':'five_percent' with linespoints lc 1 pt 7 title '5 %', \
       '' using 'sphericity':'one_percent' with linespoints lc 2 pt 7 title '1 %', \
       '' using 'sphericity':'tenth_percent' with linespoints lc 3 pt 7 title '0.1 %', \
       (p == 3 ? 'column_stands.csv' : file) using (p == 3 ? column(2) : NaN):1 @theory title 'stable below'
}
unset multiplot
