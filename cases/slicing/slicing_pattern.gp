# one joint pattern, cut in four ways
set terminal svg size 800,860 @page
rock  = "with filledcurves closed fc rgb '#efe6d2' fs solid noborder"
count(name) = system("sed -n 2p pattern_counts.csv | cut -d, -f" . name) + 0
names = "persistent extended sized healed"
titles(k) = k == 1 ? 'a  joints without end' : k == 2 ? 'b  extended to the next joint' : \
            k == 3 ? 'c  as b, inscribed diameter at least 0.4 m' : 'd  healed where a joint ends'
set multiplot
@picture
set xrange [-0.1:10.1]
set yrange [-0.1:10.1]
unset key
do for [k = 1:4] {
  name = word(names, k)
  left = (k % 2 == 1) ? 0.01 : 0.505
  top = (k < 3) ? 0.955 : 0.495
  set lmargin at screen left
  set rmargin at screen left + 0.485
  set tmargin at screen top
  set bmargin at screen top - 0.42
  set title sprintf('%s: %d blocks', titles(k), count(sprintf('%d', k))) font ',13' offset 0, -0.6
  # what is cut to a least size has no small blocks to draw
  plot 'pattern_'.name.'.csv' using 1:2 @rock notitle, \
       'pattern_'.name.(k == 3 ? '' : '_small').'.csv' using 1:2 with filledcurves closed \
           fc rgb (k == 3 ? '#efe6d2' : '#f0a070') fs solid noborder notitle, \
       'pattern_'.name.'_edges.csv' using 1:2:3:4 with vectors nohead lc rgb '#6f6450' lw 1.2 notitle, \
       'pattern_joints.csv' using 1:2:3:4 with vectors nohead lc rgb '#0072b2' lw 1.6 notitle
}
set size nosquare
# the legend below all four
set lmargin at screen 0.02
set rmargin at screen 0.98
set tmargin at screen 0.045
set bmargin at screen 0.005
unset title
set key center center horizontal samplen 3 spacing 1.2
plot NaN @rock title 'block', \
     NaN with filledcurves closed fc rgb '#f0a070' fs solid noborder title 'block of less than 0.4 m', \
     NaN with lines lc rgb '#6f6450' lw 1.2 title 'edge of a block', \
     NaN with lines lc rgb '#0072b2' lw 1.6 title 'joint as drawn'
unset multiplot
