# the top cube in the first mode
set xlabel 'time (s)'
set ylabel 'displacement of the top (mm)'
set xrange [0:0.6]
plot 'mode.csv' using 'time_s':'closed_form_mm' @theory title 'closed form', \
     '' using 'time_s':'top_mm' every 6 @computed title 'this run'
