local x = qwertzuiop
