# Results of the versions, case by case, against the present. draw.sh passes: data (history.csv), cases (names, '|'
# between them).
count = 1
do for [i=1:strlen(cases)] { if (cases[i:i] eq '|') { count = count + 1 } }
array name[count]
rest = cases
do for [i=1:count] {
  cut = strstrt(rest, '|')
  name[i] = cut > 0 ? rest[1:cut-1] : rest
  rest = rest[cut+1:*]
}
columns = 4
rows = (count + columns - 1) / columns
cost = 'contact evaluations of the costliest run'
stats data using 'place' nooutput name 'place'

set terminal svg size 900,(60 + 126*rows) font 'DejaVu Sans,Helvetica,Arial,sans-serif,10'
set datafile missing NaN
unset key
unset title
set xrange [-0.3:place_max + 0.3]
# values that changed by more than their own size are drawn at the edge
tall(change) = asinh((change > 1 ? 1 : change < -1 ? -1 : change) / 1e-6)
set yrange [1.05*tall(-1):1.05*tall(1)]
set ytics ('−1 %%' tall(-0.01), '' tall(-1e-4), '0' 0, '' tall(1e-4), '+1 %%' tall(0.01)) font ',8'
set xtics font ',8' offset 0,0.5
of(i) = strcol('case') eq name[i] ? tall(column('change')) : NaN
is_cost(n) = strcol('quantity') eq cost
colour(n) = is_cost(0) ? 0x0072b2 : column('moved') == 1 ? 0xd55e00 : 0x909090
shape(n) = is_cost(0) ? 4 : 7
size(n) = is_cost(0) ? 1.0 : column('moved') == 1 ? 0.8 : 0.5
set multiplot layout rows,columns margins 0.05,0.985,0.03,1 - 50.0/(60 + 126*rows) spacing 0.045,42.0/(60 + 126*rows)
set label 1 'change against now: values (grey), those that moved (orange), contact evaluations (blue squares)' \
    at screen 0.5, screen 1 - 14.0/(60 + 126*rows) center font ',12'
do for [i=1:count] {
  set title name[i] noenhanced font ',11' offset 0,-0.8
  plot data using 'place':(of(i)):(size(0)):(shape(0)):(colour(0)):xtic(4) with points ps variable pt variable lw 1.5 \
       lc rgb variable
  unset label 1
}
unset multiplot
