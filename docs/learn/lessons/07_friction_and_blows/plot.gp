# Displacement of the block and the parabola by hand; positions of the three balls.
set terminal svg size 700,720 font "sans,13" background "white"
set output "out/contacts.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set multiplot layout 3,1
set xlabel "t [s]"
set ylabel "displacement [m]"
set key outside right
down(x) = (x - 0.025) / cos(pi / 6)
plot "out/slides.csv" using "t[s]":(down(column("links/block/x[m]"))) with lines lw 2 lc 7 title "friction 0.5", \
     0.5 * 0.657145 * x**2 with lines dt 2 lc 0 title "by hand", \
     "out/stays.csv" using "t[s]":(down(column("links/block/x[m]"))) with lines lw 2 lc 6 title "friction 0.6"
set ylabel "x [m]"
set xrange [0:0.3]
do for [case in "apart touching"] {
  set title "three balls, two of them ".case
  plot for [i = 1:3] "out/".case.".csv" using "t[s]":(column("links/ball".i."/x[m]")) with lines lw 2 title "ball ".i
}
