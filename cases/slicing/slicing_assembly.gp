# the assembly in space, seen from east, south and above, without the blocks of one corner
set terminal svg size 620,700 @page
@picture
unset key
set lmargin 0
set rmargin 0
set tmargin 0
set bmargin 0
set xrange [-18.5:18]
set yrange [-21.5:20]
load 'assembly.gp'
# length of a side
set arrow 1 from -17.3, -10.8 to -0.4, -19.9 heads size 0.4,20 lc rgb '#404040'
set label 1 '24 m' at -9.6, -16.2 center rotate by -28
plot NaN notitle
