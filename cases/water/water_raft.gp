# a raft after a push: heave and roll
set multiplot layout 2,1
set xrange [0:12]
set ylabel 'heave (mm)'
set yrange [-16:16]
set format x ''
plot 'raft.csv' using 'time_s':'heave_form_mm' @theory title 'closed form', \
     '' using 'time_s':'heave_mm' every 5 @computed title 'this run'
set format x '%g'
set xlabel 'time (s)'
set ylabel 'roll (deg)'
set yrange [-1.3:1.3]
plot 'raft.csv' using 'time_s':'roll_form_deg' @theory notitle, \
     '' using 'time_s':'roll_deg' every 5 @computed notitle
unset multiplot
