BEGIN {
    print "t_s;x_m;y_m;z_m"
    for (k = 0; k < 5000; k++) {
        a = 8 * atan2(1, 1) * k / 5000
        row = sprintf("%.2f;%.4f;%.4f;%.4f", k / 50, 35 * sin(a), 20 * sin(2 * a), 10 + 4 * cos(3 * a))
        gsub(/\./, ",", row)
        print row
    }
}
