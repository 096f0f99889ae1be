# Boon (2013), Fig. 4.16: the line of thrust through the contact points; an arrow at each has the direction of its force.
set terminal svg size 760,420
set multiplot
set size ratio -1
set datafile missing 'nan'
unset grid
set border 0
unset tics
set key off
set xrange [-12:288]
set yrange [-30:30]
do for [half=0:1] {
  name = half ? 'half' : 'full'
  h = half ? 11.5 : 23
  set origin 0, half ? 0.0 : 0.42
  set size 1, half ? 0.5 : 0.58
  set title (half ? '(b) half block, 77 g' : '(a) full block, 40 g') offset 0,-1.5
  set object 1 rectangle from -12,-h to 0,h fc rgb '#d8d8d8' fs solid noborder behind
  set object 2 rectangle from 276,-h to 288,h fc rgb '#d8d8d8' fs solid noborder behind
  plot name.'_blocks.csv' using 'x_mm':'y_mm' with lines lc rgb '#404040' lw 1.2, \
       name.'_line_chain.csv' using 'x_mm':'y_mm' with lines lc rgb '#0072b2' lw 1.5, \
       name.'_line.csv' using (column('x_mm')-column('along_mm')):(column('y_mm')-column('up_mm')):(2*column('along_mm')):(2*column('up_mm')) \
         with vectors nohead lc rgb '#d55e00' lw 3, \
       name.'_line.csv' using 'x_mm':'y_mm' with points lc rgb '#d55e00' pt 7 ps 0.7
}
unset multiplot
