# Oscillation with the implicit spring at three steps; grey: with the explicit spring at the longest step.
set terminal svg size 720,400 font "sans,13" background "white"
set output "out/swing.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set key outside right
set xlabel "t [s]"
set ylabel "hinge [rad]"
plot "out/explicit.csv" using "t[s]":(column("q/hinge[rad]")) with lines lw 1 lc rgb "#999999" title "explicit, 20 ms", \
     for [h in "0.001 0.01 0.02"] "out/h_".h.".csv" using "t[s]":(column("q/hinge[rad]")) with lines lw 2 title "implicit, ".h." s"
