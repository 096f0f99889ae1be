# displacement against friction angle, stepwise reduction
stats 'closed_form.csv' using 1 nooutput name 'critical'
set xlabel 'friction angle of both joints (deg)'
set ylabel 'displacement since settling (mm)'
set xrange [60:32]
set arrow from critical_min, graph 0 to critical_min, graph 1 nohead lc rgb '#404040' lw 2
set label sprintf('closed form %.3f°', critical_min) at critical_min, graph 0.9 right offset -1,0
plot 'steps.csv' using 'friction_deg':'displacement_mm' with linespoints lc rgb '#d55e00' pt 7 ps 0.4 lw 1 \
     title 'wedge, friction lowered in steps'
