"""What tests share: sample rigs and files, a hand for the window, systems to solve."""
