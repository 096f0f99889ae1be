# effect of rounding over r/size, one line for each k
set terminal svg size 1000,720 @page
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set xrange [8e-5:0.7]
set yrange [5e-6:2]
problems = 'wedge beam column'
titles = '"wedge: friction angle" "hinged beam: weight" "column: settlement" "settling pack: height"'
if (int(system('[ -f study_pack.csv ] && echo 1 || echo 0'))) problems = problems . ' pack'
shown(e) = e > 6e-6 ? e : 6e-6
set multiplot layout 2,2 margins 0.09,0.86,0.09,0.95 spacing 0.09,0.13
do for [p=1:words(problems)] {
  file = 'study_' . word(problems, p) . '.csv'
  values = system("tail -n +2 " . file . " | cut -d, -f2 | sort -gu | tr '\n' ' '")
  set title word(titles, p) offset 0,-0.7
  set xlabel (p > 2 || words(problems) - p < 2 ? 'r / size' : '')
  set ylabel (p % 2 ? 'relative change' : '')
  if (p == 2) { set key at screen 0.99,0.95 right top vertical title 'k' } else { unset key }
  plot for [i=1:words(values)] file using \
         (abs(column('sphericity') - real(word(values, i))) < 1e-9 ? column('radius') : NaN):(shown(column('error'))) \
         with linespoints lc i pt 7 ps 0.5 title word(values, i), \
       0.05 with lines dt 2 lc rgb '#808080' notitle, 0.01 with lines dt 2 lc rgb '#808080' notitle, \
       0.001 with lines dt 2 lc rgb '#808080' notitle
}
unset multiplot
