# The look of every figure: `load style`, then `set output out`, then plot.
#   plot 'curve.csv' using 'x':'lower':'upper' @band  title 'tolerance', \
#        'curve.csv' using 'x':'theory'        @theory  title 'theory', \
#        'run.csv'   using 'x':'computed'      @computed title 'computed'
# Theory is a line, computed is points, the tolerance is a band. Colours are Okabe and Ito's (2008), which stay apart
# for colour-blind readers; point shapes differ too, for print without colour.
reset
set encoding utf8
set terminal svg size 760,460 dynamic background rgb 'white' font 'DejaVu Sans,Helvetica,Arial,sans-serif,13' \
    linewidth 1 enhanced
set datafile separator comma
set key autotitle columnheader

# line types 1 to 7: what a plot takes in order when it names no style
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

# quiet frame: two axes, light grid behind the data
set border 3 lc rgb '#606060' lw 1
set tics nomirror out scale 0.6 textcolor rgb '#202020'
set grid back lc rgb '#e2e2e2' lw 1 dt 1
set title font ',15'
# the legend stands above the frame, so that it never covers data
set key outside top center horizontal samplen 2.5 spacing 1.1
set style fill solid 0.3 noborder
set bars 0.5
