# the atlas: a row of maps for every kernel, a column for every difficulty; each cell is the worst of its results
set terminal svg size 1180,1000 @page font 'DejaVu Sans,Helvetica,Arial,sans-serif,11'
kernels = 'block cut decision centre normal overlap area'
said = '"block making" "cutting" "touch or apart" "analytic centre" "normal" "overlap" "contact area"'
difficulties = '"thinness" "angle of faces (rad)" "ratio of sizes" "pair at (m)" "made at (m)" "faces"'

# lightness falls from correct to wrong, so that print without colour shows it too
set palette defined (0 '#ffffff', 1 '#cfe6f2', 2 '#f0a830', 3 '#7d7d7d', 4 '#8b0000') maxcolors 5
set cbrange [-0.5:4.5]
unset colorbox
unset key
unset grid
set border 15 lc rgb '#606060' lw 0.8
stats 'atlas.csv' using 'x' nooutput name 'column'
last = column_max
half = last / 2
set xrange [-0.5:last+0.5]
left = 0.125
top = 0.875
wide = 0.1155
gap = 0.029
high = 0.105
between = 0.0135

set multiplot
# legend
names = 'correct "answered, with a warning" "refused by name" wrong "apart: nothing to find"'
colours = '#cfe6f2 #f0a830 #7d7d7d #8b0000 #ffffff'
places = '0.125 0.235 0.445 0.605 0.705'
do for [i=1:5] {
  x = real(word(places, i))
  set object i rectangle from screen x, screen 0.962 to screen x + 0.022, screen 0.980 \
      fc rgb word(colours, i) fs solid 1 border rgb '#606060'
  set label i word(names, i) at screen x + 0.028, screen 0.971 left
}
set label 9 'depth, fraction of the smaller block''s inscribed diameter: gap (plane misses) to the left of 0, overlap (cap cut off) to the right' \
    at screen 0.5, screen 0.018 center

do for [a=1:6] {
  do for [k=1:7] {
    l = left + (a - 1) * (wide + gap)
    t = top - (k - 1) * (high + between) + 0.035
    set lmargin at screen l
    set rmargin at screen l + wide
    set tmargin at screen t
    set bmargin at screen t - high
    if (k == 1) { set title word(difficulties, a) offset 0,-0.6 font ',12' } else { unset title }
    if (a == 1) { set label 11 word(said, k) at screen 0.012, screen t - high / 2 left font ',12' } else { unset label 11 }
    if (k == 7) {
      set xtics ('-0.3' 0, '-10^{-8}' half * 0.5, '0' half, '10^{-8}' half * 1.5, '0.3' last) scale 0.4 font ',9'
    } else { set xtics ('' 0, '' half * 0.5, '' half, '' half * 1.5, '' last) scale 0.4 }
    if (a <= 2) { set yrange [13:-1]; set ytics ('1' 0, '10^{-4}' 4, '10^{-8}' 8, '10^{-12}' 12) scale 0.4 font ',9' }
    if (a == 3) { set yrange [10.5:-1.5]; set ytics ('1' 0, '10^3' 3, '10^6' 6, '10^9' 9) scale 0.4 font ',9' }
    if (a == 4 || a == 5) { set yrange [13:-1]; set ytics ('1' 0, '10^4' 4, '10^8' 8, '10^{12}' 12) scale 0.4 font ',9' }
    if (a == 6) {
      set yrange [*:*] reverse noextend
      set ytics ('4' 0, '6' 1, '12' 2, '24' 3, '40' 4, '100' 5, '400' 6, '1000' 7, '4000' 8) scale 0.4 font ',9'
    }
    if (k <= 2 && a == 4) {
      # a pair's place is no question for one block
      unset xtics; unset ytics
      set label 12 'one block only' at graph 0.5, graph 0.5 center front textcolor rgb '#606060'
    } else { unset label 12 }
    plot 'atlas.csv' using 'x':(column('axis') == a - 1 ? column('y') : NaN):(0.5):'half_height':word(kernels, k) \
         with boxxyerror lc palette fs solid 1 noborder
    if (a == 1 && k == 1) { unset for [i=1:5] object i; unset for [i=1:5] label i; unset label 9 }
  }
}
unset multiplot
