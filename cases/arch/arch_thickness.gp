# least thickness of the arch against the stiffness of its joints
set logscale x
set format x '10^{%T}'
set xlabel 'normal stiffness of the joints (GPa/m)'
set ylabel 'least thickness over radius'
set xrange [3:10000]
set yrange [0.104:0.122]
rigid = real(system("sed -n 2p rigid.csv | cut -d, -f1"))
many = real(system("sed -n 2p rigid.csv | cut -d, -f2"))
plot 'least.csv' using 'stiffness_GPa_m':'least' @theory title 'rigid voussoirs on elastic joints', \
     rigid with lines lc rgb '#0072b2' lw 2 dt 2 title 'rigid, 15 voussoirs', \
     many with lines lc rgb '#009e73' lw 1.5 dt 4 title 'Milankovitch, any number', \
     'brackets.csv' using 'stiffness_GPa_m':'stands' with points lc rgb '#d55e00' pt 9 ps 1 title 'DEM, stable', \
     '' using 'stiffness_GPa_m':'falls' with points lc rgb '#d55e00' pt 10 ps 1 title 'DEM, collapses'
