# perl signalled.pl SIGNAL CONDITION COMMAND...: runs the command, and sends it the signal as soon as it has a handler for
# signals and then the shell command CONDITION succeeds. File descriptor 3 gets what waitpid has of it, and the seconds that
# it took. Not empty, IGNORED: it ignores SIGINT from the beginning; EARLY: it need not have a handler. AND: another
# signal, for at once after it (the same one would be lost while it waits). THEN: a shell command for after it.
use strict;
use Time::HiRes qw(sleep time);
use POSIX ":sys_wait_h";

my ($signal, $condition, @command) = @ARGV;
my $begun = time;
my $pid = fork;
if (!$pid) {
    $SIG{INT} = $ENV{IGNORED} ? "IGNORE" : "DEFAULT"; # a shell ignores it in what it runs in the background
    exec @command or exit 99;
}

# Where a system does not tell, a second is enough for most.
sub catches {
    return 1 if $ENV{EARLY};
    open my $file, "<", "/proc/$pid/status" or return time > $begun + 1;
    my ($caught) = join("", <$file>) =~ /^SigCgt:\s*([0-9a-f]+)/m;
    return hex(substr $caught, -4) & 0x4003; # SIGHUP, SIGINT, SIGTERM
}

my ($ended, $status) = (0, 0);
for my $ready (\&catches, sub { system("sh", "-c", $condition) == 0 }) {
    my $end = time + 60;
    until ($ended || $ready->() || time > $end) {
        sleep 0.01;
        $ended = waitpid $pid, WNOHANG and $status = $?;
    }
}
if (!$ended) {
    kill $_, $pid for $signal, $ENV{AND} || ();
    system $ENV{THEN} if $ENV{THEN};
    $SIG{ALRM} = sub { kill "KILL", $pid };
    alarm 60; # one that does not end fails the test, and does not stay
    waitpid $pid, 0;
    $status = $?;
}
open my $said, ">&=", 3 or die;
print $said $status, " ", time - $begun, "\n";
