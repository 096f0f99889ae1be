# openings 12 and 11 of table 5.1, four tenths of a second after the excavation
set terminal svg size 1000,520 @page
@picture
unset key
set xrange [-14:14]
set yrange [-11:15]
left = "with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#b0a58c'"
lost = "with filledcurves closed fc rgb '#d55e00' fs solid border lc rgb '#6f3000'"
set multiplot layout 1,2 margins 0.01, 0.99, 0.01, 0.93 spacing 0.02
do for [n in '12 11'] {
  set title n eq '12' ? 'opening 12: 85°E, 75°E, 65°W, φ = 35°' : 'opening 11: the same blocks, φ = 25°'
  plot 'opening_'.n.'_left.csv' using 1:2 @left, 'opening_'.n.'_lost.csv' using 1:2 @lost
}
unset multiplot
