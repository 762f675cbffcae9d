local h = history.piecewise{ times = { 0, 2*us, 1*us }, values = { 0, 1, 0 } }
