# plastic slip of the block whose contact rings
set xlabel 'time since gravity doubled (s)'
set ylabel 'plastic slip (mm)'
set xrange [0:1]
set yrange [0:60]
plot 'ringing.csv' using 'time_s':'closed_form_mm' @theory title 'spring and slider under a force that rings', \
     '' using 'time_s':'slip_mm' every 4 @computed title 'this run'
