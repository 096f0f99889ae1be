# critical friction of the wedge over the joints' stiffness ratio and over the stress applied from outside
set terminal svg size 980,430 @page
set multiplot layout 1,2 margins 0.10,0.98,0.15,0.95 spacing 0.11
set ylabel 'critical friction (deg)'
set key inside top right vertical
set xlabel 'k_n/k_s'
set key bottom right
set logscale x
set xrange [0.07:14]
plot 'closed_form_ratio.csv' using 'ratio':'friction_deg' @theory title 'joint relaxation, closed form', \
     'traction_ratio.csv' using 'ratio':'friction_deg' @computed title 'DEM, tractions on the sides'
unset logscale x
set key top right
set xlabel 'horizontal stress (MPa)'
set xrange [0:0.22]
plot 'closed_form_stress.csv' using 'stress_MPa':'friction_deg' @theory title 'joint relaxation, closed form', \
     'traction_stress.csv' using 'stress_MPa':'friction_deg' @computed title 'DEM, tractions on the sides'
unset multiplot
