# The look of every figure; draw.sh runs it before the figure's own file, which only plots. A figure of another size begins with
#   set terminal svg size 1000,520 @page
#   plot 'curve.csv' using 'x':'lower':'upper' @band  title 'tolerance', \
#        'curve.csv' using 'x':'theory'        @theory  title 'theory', \
#        'run.csv'   using 'x':'computed'      @computed title 'computed'
# Theory is a line, computed is points, the tolerance is a band. Colours are Okabe and Ito's (2008), which stay apart
# for colour-blind readers; point shapes differ too, for print without colour.
reset
set encoding utf8
page = "dynamic background rgb 'white' font 'DejaVu Sans,Helvetica,Arial,sans-serif,13' linewidth 1 enhanced"
set terminal svg size 760,460 @page
set datafile separator comma
set key autotitle columnheader

# line types 1 to 7: taken in order by a plot that names no style
set linetype 1 lc rgb '#0072b2' lw 2 pt 7  ps 0.6
set linetype 2 lc rgb '#d55e00' lw 2 pt 5  ps 0.6
set linetype 3 lc rgb '#009e73' lw 2 pt 9  ps 0.7
set linetype 4 lc rgb '#cc79a7' lw 2 pt 13 ps 0.7
set linetype 5 lc rgb '#e69f00' lw 2 pt 11 ps 0.7
set linetype 6 lc rgb '#56b4e9' lw 2 pt 4  ps 0.6
set linetype 7 lc rgb '#404040' lw 2 pt 6  ps 0.6
set linetype cycle 7

# the three roles; with several curves use the line types above and keep line for theory, points for computed
theory   = "with lines lc rgb '#404040' lw 2"
computed = "with points lc rgb '#d55e00' pt 7 ps 0.6"
band     = "with filledcurves fc rgb '#0072b2' fs transparent solid 0.15 noborder"

# quiet frame: two axes, light grid behind the data; `@picture` for blocks: neither, and one scale for both
set border 3 lc rgb '#606060' lw 1
set tics nomirror out scale 0.6 textcolor rgb '#202020'
set grid back lc rgb '#e2e2e2' lw 1 dt 1
picture = "unset border; unset tics; unset grid; set size ratio -1"
stone = "with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#8c7f66'"
set title font ',15'
# the legend is above the frame, so that it never covers data
set key outside top center horizontal samplen 2.5 spacing 1.1
set style fill solid 0.3 noborder
set bars 0.5
