# the section before and after its failure: blocks, and the contacts' forces as bars along them
set terminal svg size 1000,520 @page
@picture
unset key
set xrange [0:1480]
set yrange [545:1190]
set multiplot layout 2,2 margins 0.01, 0.99, 0.01, 0.94 spacing 0.02, 0.08
do for [moment in 'rest before thirty end'] {
  set title moment eq 'rest' ? 'friction of the slide 35.65°' : moment eq 'before' ? 'friction 20.65°, before the loss' : \
            moment eq 'thirty' ? 'moved by 30 m' : 'moved by 118 m'
  plot 'slide_fixed.csv' using 1:2 with filledcurves closed fc rgb '#d5d5d5' fs solid border lc rgb '#a0a0a0', \
       'slide_'.moment.'.csv' using 1:2 with filledcurves closed fc rgb '#efe6d2' fs solid border lc rgb '#b0a58c', \
       'slide_'.moment.'_forces.csv' using 1:2:3:4 with vectors nohead lc rgb '#d55e00' lw 2
}
unset multiplot
